// Files of a shop: results of a measuring machine, a program.

/** Twelve seats in QIF, each 1 um larger than the one before, and 0.1 um to both sides in turn. */
export function results() {
  const mm = '<LinearUnit><UnitName>mm</UnitName><UnitConversion><Factor>0.001</Factor></UnitConversion></LinearUnit>';
  const part = (k) => `<MeasurementResults id="${100 + k}"><MeasuredCharacteristics><CharacteristicMeasurements>
    <DiameterCharacteristicMeasurement id="${200 + k}"><CharacteristicItemId>3</CharacteristicItemId>
    <Value>${(30 + 0.001 * k + (k % 2 ? 1e-4 : -1e-4)).toFixed(4)}</Value></DiameterCharacteristicMeasurement>
    </CharacteristicMeasurements></MeasuredCharacteristics></MeasurementResults>`;
  return `<QIFDocument xmlns="http://qifstandards.org/xsd/qif3"><FileUnits><PrimaryUnits>${mm}</PrimaryUnits></FileUnits>
    <MeasurementResources><MeasurementDevices><Micrometer id="9"><Name>M25</Name></Micrometer></MeasurementDevices></MeasurementResources>
    <Characteristics><CharacteristicDefinitions><DiameterCharacteristicDefinition id="1"><Tolerance><MaxValue>0.02</MaxValue>
    <MinValue>-0.02</MinValue></Tolerance></DiameterCharacteristicDefinition></CharacteristicDefinitions>
    <CharacteristicNominals><DiameterCharacteristicNominal id="2"><CharacteristicDefinitionId>1</CharacteristicDefinitionId>
    <TargetValue>30</TargetValue></DiameterCharacteristicNominal></CharacteristicNominals>
    <CharacteristicItems><DiameterCharacteristicItem id="3"><Name>seat</Name><MeasurementDeviceIds><Id>9</Id></MeasurementDeviceIds>
    <CharacteristicNominalId>2</CharacteristicNominalId></DiameterCharacteristicItem></CharacteristicItems></Characteristics>
    <Results><MeasurementResultsSet>${Array.from({ length: 12 }, (_, k) => part(k + 1)).join('')}</MeasurementResultsSet></Results></QIFDocument>`;
}

/** Of three passes in a loop, with one code that no control knows. */
export const program = `(T1 PCLNL-CNMG120408-PM, CORNER 0.8 MM)
G99 T0101
G97 S1000 M3
G0 X44. Z2.
#1=36.
WHILE [#1 GE 32.] DO1
G0 X#1
G1 Z-10. F0.2
G0 X[#1+4.]
Z2.
#1=#1-2.
END1
G123
M30
`;
